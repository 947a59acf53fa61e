"""Errors of a picture against its reference, from their EXR files alone: linear rmse, bias and max; of what a view
transform makes of them psnr_db, ssim (Wang et al. 2004) and flip (Andersson et al. 2020). Written from the papers."""

import dataclasses

import numpy as np
import OpenImageIO as oiio

# EXR holds half floats: a value is off by half a unit in the last of 11 places, or by half the least subnormal.
HALF_RELATIVE, HALF_ABSOLUTE = 2.0**-11, 2.0**-25
# rmse was summed in another order, in double precision, of float pixels.
SUM_EPSILON = 1e-9
# Sward computes FLIP in single precision, and says that differences below 1e-5 are noise.
FLIP_NOISE = 1e-5
# Its view transform and sRGB curve are in single precision too: some roundings of 2^-24 of a value up to 1.
DISPLAY_NOISE = 2.0**-20
PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * np.pi / 180.0  # the paper's: 3840 pixels on 0.7 m, seen from 0.7 m


@dataclasses.dataclass
class PictureErrors:
    """name -> (value, how far a report's may be from it because its pictures were rounded to half floats)"""

    figures: dict


def read_linear(path):
    """RGB as float64, [height, width, 3]."""
    buffer = oiio.ImageBuf(str(path))
    if buffer.has_error:
        raise OSError(f"{path}: {buffer.geterror()}")
    return np.asarray(buffer.get_pixels(oiio.FLOAT), dtype=np.float64)[..., :3]


def srgb_from_linear(linear):
    """IEC 61966-2-1."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-12) ** (1 / 2.4) - 0.055)


def linear_from_srgb(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def filmic(linear):
    """Hill's fit of ACES (BakingLab, 2016), exposed by 1 / 0.6."""
    into = np.array([[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]])
    back = np.array([[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]])
    v = (linear / 0.6) @ into.T
    return ((v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)) @ back.T


def display_of(linear, transform):
    """sRGB-encoded, in [0, 1]."""
    shown = np.maximum(linear, 0.0)
    if transform == "filmic":
        shown = filmic(shown)
    elif transform != "standard":
        raise ValueError(f"there is no view transform {transform!r}")
    return srgb_from_linear(np.clip(shown, 0.0, 1.0))


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


def correlate(plane, kernel):
    """Of one plane with an odd square kernel; beyond the edge the outermost pixel is repeated."""
    radius = kernel.shape[0] // 2
    padded = np.pad(plane, radius, mode="edge")
    # Enough room that the circular correlation of the transform wraps only into what is cut off.
    spectrum = np.fft.rfft2(padded) * np.conj(np.fft.rfft2(kernel, padded.shape))
    return np.fft.irfft2(spectrum, padded.shape)[: plane.shape[0], : plane.shape[1]]


def ssim(reference, test):
    """Mean over the windows of 11 x 11 that lie in the image, of luma; Gaussian of sigma 1.5, K1 0.01, K2 0.03."""
    weights = np.array([0.2126, 0.7152, 0.0722])
    x, y = reference @ weights, test @ weights
    i = np.arange(-5, 6)
    window = np.exp(-(i[:, None] ** 2 + i[None, :] ** 2) / (2 * 1.5**2))
    window /= window.sum()
    inner = (slice(5, -5) if x.shape[0] > 10 else slice(None), slice(5, -5) if x.shape[1] > 10 else slice(None))
    mean_x, mean_y = correlate(x, window)[inner], correlate(y, window)[inner]
    var_x = correlate(x * x, window)[inner] - mean_x**2
    var_y = correlate(y * y, window)[inner] - mean_y**2
    cov = correlate(x * y, window)[inner] - mean_x * mean_y
    c1, c2 = 0.01**2, 0.03**2
    top = (2 * mean_x * mean_y + c1) * (2 * cov + c2)
    return float(np.mean(top / ((mean_x**2 + mean_y**2 + c1) * (var_x + var_y + c2))))


# Linear Rec. 709 to XYZ, from the primaries of BT.709 and the white D65 (0.3127, 0.3290).
def xyz_matrix():
    x = np.array([[0.64, 0.30, 0.15], [0.33, 0.60, 0.06], [0.03, 0.10, 0.79]])
    white = np.array([0.3127 / 0.3290, 1.0, (1 - 0.3127 - 0.3290) / 0.3290])
    return x * np.linalg.solve(x, white), white


XYZ_FROM_LINEAR, WHITE = xyz_matrix()


def ycxcz_from_linear(linear):
    ratios = linear @ XYZ_FROM_LINEAR.T / WHITE
    x, y, z = ratios[..., 0], ratios[..., 1], ratios[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def linear_from_ycxcz(ycxcz):
    y = (ycxcz[..., 0] + 16) / 116
    ratios = np.stack([y + ycxcz[..., 1] / 500, y, y - ycxcz[..., 2] / 200], axis=-1)
    return (ratios * WHITE) @ np.linalg.inv(XYZ_FROM_LINEAR).T


def hunt_lab(linear):
    """L*a*b*, chroma scaled by 0.01 L* (Hunt)."""
    ratios = linear @ XYZ_FROM_LINEAR.T / WHITE
    knee = 6 / 29
    f = np.where(ratios > knee**3, np.cbrt(ratios), ratios / (3 * knee**2) + 4 / 29)
    lightness = 116 * f[..., 1] - 16
    a, b = 500 * (f[..., 0] - f[..., 1]), 200 * (f[..., 1] - f[..., 2])
    return np.stack([lightness, 0.01 * lightness * a, 0.01 * lightness * b], axis=-1)


def hyab_power(first, second):
    difference = first - second
    distance = np.abs(difference[..., 0]) + np.hypot(difference[..., 1], difference[..., 2])
    return distance**0.7


def sensitivity_kernels():
    """Contrast sensitivity of the channels Y, Cx, Cz as kernels of the plane that sum to 1."""
    terms = ([(1.0, 0.0047)], [(1.0, 0.0053)], [(34.1, 0.04), (13.5, 0.025)])
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PIXELS_PER_DEGREE))
    i = np.arange(-radius, radius + 1) / PIXELS_PER_DEGREE
    square = i[:, None] ** 2 + i[None, :] ** 2
    kernels = []
    for channel in terms:
        kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * square / b) for a, b in channel)
        kernels.append(kernel / kernel.sum())
    return kernels


def feature_kernels():
    """Derivatives along x of a Gaussian, first (edges) and second (points); positive weights sum to 1, negative to -1."""
    sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE
    i = np.arange(-int(np.ceil(3 * sigma)), int(np.ceil(3 * sigma)) + 1)
    x, y = i[None, :], i[:, None]
    gaussian = np.exp(-(x**2 + y**2) / (2 * sigma**2))
    kernels = []
    for kernel in (-x * gaussian, (x**2 / sigma**2 - 1) * gaussian):
        positive, negative = kernel[kernel > 0].sum(), -kernel[kernel < 0].sum()
        kernels.append(np.where(kernel > 0, kernel / positive, kernel / negative))
    return kernels


def flip(reference, test):
    """Mean of the map of LDR-FLIP of two display images."""
    sides = []
    for display in (reference, test):
        opponent = ycxcz_from_linear(linear_from_srgb(display))
        seen = np.stack([correlate(opponent[..., c], k) for c, k in enumerate(sensitivity_kernels())], axis=-1)
        lab = hunt_lab(np.clip(linear_from_ycxcz(seen), 0.0, 1.0))
        luminance = (opponent[..., 0] + 16) / 116
        features = [np.hypot(correlate(luminance, k), correlate(luminance, k.T)) for k in feature_kernels()]
        sides.append((lab, features))
    greatest = hyab_power(hunt_lab(np.array([0.0, 1.0, 0.0])), hunt_lab(np.array([0.0, 0.0, 1.0])))
    colour = hyab_power(sides[0][0], sides[1][0])
    knee = 0.4 * greatest
    colour = np.where(colour < knee, 0.95 / knee * colour, 0.95 + (colour - knee) / (greatest - knee) * 0.05)
    feature = np.maximum(*(np.abs(a - b) for a, b in zip(sides[0][1], sides[1][1])))
    feature = np.clip((feature / np.sqrt(2)) ** 0.5, 0.0, 1.0)
    return float(np.mean(np.clip(colour, 0.0, 1.0) ** (1 - feature)))


def display_figures(test, reference, transform, with_flip):
    shown_test, shown_reference = display_of(test, transform), display_of(reference, transform)
    figures = {"display_rmse": rms(shown_test - shown_reference), "ssim": ssim(shown_reference, shown_test)}
    if with_flip:
        figures["flip"] = flip(shown_reference, shown_test)
    return figures


def display_shift(linear, transform):
    """By how much rounding moves each display value at most: the sum over the channels of what half a unit of each
    changes (to first order; transforms mix channels)."""
    shown, shift = display_of(linear, transform), 0.0
    for channel in range(3):
        moved = linear.copy()
        moved[..., channel] += HALF_RELATIVE * np.abs(linear[..., channel]) + HALF_ABSOLUTE
        shift = shift + np.abs(display_of(moved, transform) - shown)
    return shift


def display_slack(test, reference, transform, shown):
    """By how much rounding may have moved ssim and flip: the pictures are rounded again, twice at random and once each
    all in one direction, as equal values are. The first rounding moved a figure as the random ones do: by their mean,
    give or take a few times what sets the two apart; twice the mean leaves room for it."""
    random = np.random.default_rng(1)
    noise = lambda linear: linear * (1 + HALF_RELATIVE * random.uniform(-1, 1, linear.shape))
    scaled = lambda linear: linear * (1 + HALF_RELATIVE)
    pairs = [(noise(test), noise(reference)), (noise(test), noise(reference)),
             (scaled(test), reference), (test, scaled(reference))]
    again = [display_figures(*pair, transform, "flip" in shown) for pair in pairs]
    slack = {}
    for name, value in shown.items():
        change = [figures[name] - value for figures in again]
        at_random = abs(change[0] + change[1]) + 8 * abs(change[0] - change[1])
        slack[name] = max(at_random, abs(change[2]) + abs(change[3]))
    return slack


def picture_errors(test_file, reference_file, transform, with_flip):
    """All figures with their tolerances.

    Rounding to half floats moves every difference by at most e, the sum of both half units; by the triangle inequality
    rmse moves by at most rms(e), bias by mean(e), max by max(e). PSNR likewise, with the shifts of display values.
    """
    test, reference = read_linear(test_file), read_linear(reference_file)
    if test.shape != reference.shape:
        raise ValueError(f"{test_file} and {reference_file} differ in size")
    difference = test - reference
    rounding = HALF_RELATIVE * (np.abs(test) + np.abs(reference)) + 2 * HALF_ABSOLUTE
    figures = {"rmse": (rms(difference), rms(rounding) + SUM_EPSILON),
               "bias": (float(np.mean(difference)), float(np.mean(rounding)) + SUM_EPSILON),
               "max": (float(np.max(np.abs(difference))), float(np.max(rounding)) + SUM_EPSILON)}
    shown = display_figures(test, reference, transform, with_flip)
    slack = display_slack(test, reference, transform, shown)
    figures["ssim"] = (shown["ssim"], slack["ssim"] + DISPLAY_NOISE)
    if with_flip:
        figures["flip"] = (shown["flip"], slack["flip"] + FLIP_NOISE)
    value = shown["display_rmse"]
    if value > 0:
        shift = rms(display_shift(test, transform) + display_shift(reference, transform)) + DISPLAY_NOISE
        figures["psnr_db"] = (-20 * np.log10(value), 20 * np.log10(1 + shift / value))
    return PictureErrors(figures)
