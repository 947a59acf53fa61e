"""Fits the compact forms of core/leaf/spectra_lobes.cpp: constants plus sums of Gaussians, by Levenberg-Marquardt.

    fit_spectra.py ASSETS            prints the parameters as rows of C++
    fit_spectra.py ASSETS --check F  compares what F (that source file) holds with a new fit; exits 1 where they differ
    fit_spectra.py ASSETS --errors   prints the residuals of the fits

ASSETS is the folder `spectra` of measured and published tables. Needs NumPy and nothing else, and no table of it comes
into the source: only the fitted parameters do. Sources of what is fitted:
- PROSPECT-5: Feret et al. 2008, Remote Sensing of Environment 112, 3030-3043;
- PROSPECT-D: Feret et al. 2017, Remote Sensing of Environment 193, 204-215;
- chlorophyll a and b in diethyl ether: PhotochemCAD (Du et al. 1998, Dixon et al. 2005), scaled as Strain et al. 1963
  and Vernon and Seely 1966;
- carotenoids: curves of the LipidBank, relative, in the shares of a green leaf;
- CIE 1931 colour-matching functions and D65.
"""

import argparse
import pathlib
import re
import sys

import numpy as np

FIRST_NM, LAST_NM = 400.0, 750.0
GRID_NM = np.arange(FIRST_NM, LAST_NM + 0.5)

# Shares of the carotenoids of a green leaf (Lichtenthaler 1987: lutein about half, beta-carotene a quarter to a third).
CAROTENOIDS = {"Lutein": 0.45, "beta-carotene": 0.30, "Violaxanthin": 0.20, "Zeaxanthin": 0.05}
# Molar extinction at the peaks, 1/(cm M), of chlorophyll a and of carotenoids (lutein 144,800, beta-carotene 139,000).
CHLOROPHYLL_A_PEAK = 111700.0
CAROTENOID_PEAK = 142000.0


def table(path, columns, delimiter=None, skip=0):
    lines = path.read_text().splitlines()[skip:]
    rows = [line.replace(",", " ").split() if delimiter else line.split() for line in lines]
    rows = [[float(word) for word in row] for row in rows if row and not row[0].startswith("#")]
    return np.array([[row[c] for c in columns] for row in rows])


def resampled(nm, values):
    """Onto the grid; 0 beyond the last wavelength (the tables end where nothing is absorbed)."""
    order = np.argsort(nm, kind="stable")
    return np.interp(GRID_NM, nm[order], values[order], right=0.0)


def carotenoids(folder):
    total = np.zeros_like(GRID_NM)
    for name, share in CAROTENOIDS.items():
        data = table(folder / f"{name}.csv", [0, 1], ",", skip=1)
        values = resampled(data[:, 0], data[:, 1])
        total += share * np.maximum(values, 0.0) / values.max()
    return total / total.max() * CAROTENOID_PEAK / CHLOROPHYLL_A_PEAK


def targets(assets):
    """Name -> values on the grid."""
    five = table(assets / "prospect/prospect5_spectra.txt", range(6))[: len(GRID_NM)]
    late = table(assets / "prospect/prospect_d_spectra.txt", range(8))[: len(GRID_NM)]
    cmf = table(assets / "cie/cie1931_2deg_xyz_360-830_1nm.csv", range(4), ",", skip=1)
    d65 = table(assets / "cie/cie_illuminant_D65_300-830_5nm.csv", range(2), ",", skip=1)
    a = table(assets / "pigments/chla-123-abs.txt", [0, 1])
    b = table(assets / "pigments/chlb-125-abs.txt", [0, 1])
    return {
        "Prospect5Index": five[:, 0],
        "Prospect5Chlorophyll": five[:, 1],
        "Prospect5Carotenoid": five[:, 2],
        "ProspectDIndex": late[:, 1],
        "ProspectDChlorophyll": late[:, 2],
        "ProspectDCarotenoid": late[:, 3],
        "Brown": five[:, 3],
        "Water": five[:, 4],
        "DryMatter": five[:, 5],
        "ChlorophyllA": resampled(a[:, 0], a[:, 1]) / CHLOROPHYLL_A_PEAK,
        "ChlorophyllB": resampled(b[:, 0], b[:, 1]) / CHLOROPHYLL_A_PEAK,
        "MeanCarotenoid": carotenoids(assets / "pigments"),
        "ObserverX": resampled(cmf[:, 0], cmf[:, 1]),
        "ObserverY": resampled(cmf[:, 0], cmf[:, 2]),
        "ObserverZ": resampled(cmf[:, 0], cmf[:, 3]),
        "DaylightD65": resampled(d65[:, 0], d65[:, 1]) / 100.0,
    }


# First guesses, (centre, width) in nm; their number is what the form is made of.
GUESSES = {
    "Prospect5Index": [(445, 25), (490, 25), (440, 10), (555, 20), (625, 25), (676, 10), (662, 25), (725, 10), (755, 25)],
    "Prospect5Chlorophyll": [(405, 10), (430, 15), (450, 20), (475, 12), (500, 15), (560, 20), (585, 12), (618, 15),
                             (648, 12), (675, 8), (685, 8)],
    "Prospect5Carotenoid": [(390, 12), (425, 25), (455, 20), (490, 15), (510, 12), (530, 10)],
    "ProspectDIndex": [(400, 20), (450, 40), (520, 30), (560, 40), (680, 30)],
    "ProspectDChlorophyll": [(400, 8), (415, 15), (440, 15), (460, 15), (485, 15), (510, 10), (560, 20), (585, 12),
                             (620, 15), (650, 12), (673, 9), (688, 8)],
    "ProspectDCarotenoid": [(400, 20), (430, 20), (455, 18), (485, 15), (505, 12), (530, 12)],
    "Brown": [(400, 80), (520, 60), (620, 90)],
    "Water": [(605, 12), (650, 40), (725, 8), (740, 12), (755, 15)],
    "DryMatter": [(385, 20), (400, 30), (430, 30)],
    "ChlorophyllA": [(380, 20), (409, 8), (428, 5), (431, 8), (425, 18), (530, 15), (575, 10), (613, 12), (640, 15), (660, 7),
                     (660, 14)],
    "ChlorophyllB": [(405, 20), (430, 12), (452, 5), (454, 9), (455, 15), (545, 15), (595, 12), (640, 7), (635, 18), (650, 10)],
    "MeanCarotenoid": [(390, 25), (423, 12), (448, 10), (460, 15), (477, 9), (490, 12)],
    "ObserverX": [(425, 10), (443, 12), (455, 15), (470, 15), (555, 25), (590, 25), (610, 25), (640, 25)],
    "ObserverY": [(450, 20), (500, 15), (530, 20), (560, 35), (610, 30)],
    "ObserverZ": [(418, 8), (430, 10), (443, 12), (460, 12), (480, 15), (505, 20)],
    "DaylightD65": [(410, 8), (430, 5), (450, 20), (480, 20), (540, 40), (620, 15), (690, 15), (720, 10), (750, 10)],
}
# Part of the greatest value below which an error counts as much as there: where a leaf holds much of something, the
# weak flanks of its absorption matter as much as the peaks.
KNEE = {"Prospect5Chlorophyll": 0.08, "ProspectDChlorophyll": 0.08, "Prospect5Carotenoid": 0.2,
        "ProspectDCarotenoid": 0.2, "ChlorophyllA": 0.3, "ChlorophyllB": 0.3, "DryMatter": 0.05}


# Forms without a constant: what is 0 outside its lobes.
BARE = {"Prospect5Carotenoid", "ProspectDCarotenoid", "MeanCarotenoid", "ChlorophyllA", "ChlorophyllB",
        "ObserverX", "ObserverY", "ObserverZ"}


def model(parameters, nm):
    value = np.full_like(nm, parameters[0])
    for amplitude, centre, width in parameters[1:].reshape(-1, 3):
        value = value + amplitude * np.exp(-0.5 * ((nm - centre) / width) ** 2)
    return value


def jacobian(parameters, nm):
    columns = [np.ones_like(nm)]
    for amplitude, centre, width in parameters[1:].reshape(-1, 3):
        u = (nm - centre) / width
        bell = np.exp(-0.5 * u * u)
        columns += [bell, amplitude * bell * u / width, amplitude * bell * u * u / width]
    return np.stack(columns, axis=1)


def admissible(parameters):
    lobes = parameters[1:].reshape(-1, 3)
    return np.all(lobes[:, 2] > 2.0) and np.all(lobes[:, 2] < 150.0) and np.all(np.abs(lobes[:, 1] - 575.0) < 260.0)


def fit(name, values, steps=600):
    """Levenberg-Marquardt (Marquardt 1963) on weighted residuals, from linear amplitudes at the guessed places."""
    scale = np.abs(values).max()
    weight = 1.0 / (np.abs(values) + KNEE.get(name, 1e3) * scale)
    guess = np.array(GUESSES[name], dtype=float)
    parameters = np.concatenate([[0.0], np.stack([np.ones(len(guess)), guess[:, 0], guess[:, 1]], axis=1).ravel()])
    free = np.arange(1 if name in BARE else 0, len(parameters))
    linear = [i for i in free if i == 0 or i % 3 == 1]
    basis = jacobian(parameters, GRID_NM)[:, linear] * weight[:, None]
    ridge = 1e-3 * np.eye(len(linear)) * np.mean(np.sum(basis**2, axis=0))
    parameters[linear] = np.linalg.solve(basis.T @ basis + ridge, basis.T @ (values * weight))
    damping, residual = 1e-2, (values - model(parameters, GRID_NM)) * weight
    for _ in range(steps):
        j = jacobian(parameters, GRID_NM)[:, free] * weight[:, None]
        normal, gradient = j.T @ j, j.T @ residual
        diagonal = np.diag(np.maximum(np.diag(normal), 1e-12 * np.diag(normal).max()))
        step = np.linalg.solve(normal + damping * diagonal, gradient)
        moved = parameters.copy()
        moved[free] += step
        new = (values - model(moved, GRID_NM)) * weight if admissible(moved) else None
        if new is not None and new @ new < residual @ residual:
            parameters, residual, damping = moved, new, max(damping * 0.4, 1e-9)
        else:
            damping = min(damping * 3.0, 1e9)
    return parameters


def rounded(parameters):
    """Six digits: what the source holds."""
    return np.array([float(f"{p:.6g}") for p in parameters])


def rows(name, parameters):
    lines = [f"constexpr Lobe k{name}Lobes[] = {{"]
    lobes = parameters[1:].reshape(-1, 3)
    for amplitude, centre, width in lobes[np.argsort(lobes[:, 1], kind="stable")]:
        lines.append(f"    {{{amplitude:.6g}, {centre:.6g}, {width:.6g}}},")
    lines.append("};")
    lines.append(f"constexpr double k{name}Constant = {parameters[0]:.6g};")
    return "\n".join(lines)


def read_source(path):
    """Name -> parameters, as `rows` printed them."""
    text = pathlib.Path(path).read_text()
    found = {}
    number = r"-?[0-9.]+(?:e[-+]?[0-9]+)?"
    for match in re.finditer(r"Lobe k(\w+)Lobes\[\] = \{(.*?)\};\s*constexpr double k\w+Constant = (" + number + ");",
                             text, re.S):
        lobes = re.findall(rf"\{{({number}),\s*({number}),\s*({number})\}}", match.group(2))
        found[match.group(1)] = np.array([float(match.group(3))] + [float(v) for lobe in lobes for v in lobe])
    return found


def check(assets, path):
    """Curves are compared, not parameters: lobes that overlap trade places at no cost, and rounding differs between
    builds of NumPy. A thousandth of the greatest value is a tenth of what the fits themselves miss."""
    source, bad = read_source(path), 0
    for name, values in targets(assets).items():
        if name not in source:
            print(f"{name}: not in {path}")
            bad += 1
            continue
        again = model(rounded(fit(name, values)), GRID_NM)
        difference = np.abs(model(source[name], GRID_NM) - again).max() / np.abs(values).max()
        if not difference < 1e-3:
            print(f"{name}: the source differs from a new fit by {difference:.2e} of the greatest value")
            bad += 1
    for name in source.keys() - targets(assets).keys():
        print(f"{name}: nothing is known of it here")
        bad += 1
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("assets", type=pathlib.Path)
    parser.add_argument("--check", metavar="SOURCE")
    parser.add_argument("--errors", action="store_true")
    options = parser.parse_args()
    if options.check:
        return 1 if check(options.assets, options.check) else 0
    for name, values in targets(options.assets).items():
        parameters = rounded(fit(name, values))
        if options.errors:
            error = model(parameters, GRID_NM) - values
            worst = int(np.argmax(np.abs(error)))
            print(f"{name:22} rmse {np.sqrt(np.mean(error**2)):.3g} max {np.abs(error).max():.3g} at {GRID_NM[worst]:.0f}"
                  f" nm; greatest {np.abs(values).max():.4g}")
        else:
            print(rows(name, parameters))
    return 0


if __name__ == "__main__":
    sys.exit(main())
