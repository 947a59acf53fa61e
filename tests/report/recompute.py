#!/usr/bin/env python3
"""Computes the figures of a report again, from the measured values and pictures that it was written with.

    recompute.py DIR

DIR is what `sward report -o DIR` wrote. Nothing of Sward is used: NumPy, OpenImageIO's reader of EXR files, and the
definitions of the papers. Prints every figure of report.json that does not follow from the files beside it, and what
was checked. Exit code: 0 all follow, 1 some do not, 2 there is no report that could be checked.

What is checked (core/report/section.h has the conventions):
  every row       times in order, PSNR against RMSE, and bounds that any error measures keep: |bias| <= rmse <= max
  speed           ratios against the limits that `against` names; bytes of the storage rows from their sizes
  picture rows    rmse, bias, max from the linear pictures/NAME.exr; psnr_db, ssim, flip from what the view transform
                  that the row names makes of them; rmse_without_noise from rmse and the noise that the row states;
                  relative_bias from bias and the reference's mean
  texel_render    ratios against the march; levels of fewer columns take fewer bytes
  plots           that the page holds a plot for each file
  lights          rmse, bias and max of rows from the sums over their lights in tables/SECTION_lights.csv, those sums
                  from the arrays of the lights that were kept, and rmse over that of another method
Tolerances are derived where they are used; the largest come from EXR's half floats. FLIP takes seconds a picture: it
is computed again for the first three rows that have it.
"""

import argparse
import json
import math
import pathlib
import sys

from recompute_images import HALF_ABSOLUTE, HALF_RELATIVE, PictureErrors, picture_errors, read_linear
from recompute_tables import PARAMETER_DIGITS, check_tables

# A figure of report.json is printed with 17 significant digits; sums were added in another order than here.
SUM_EPSILON = 1e-9
FLIP_PICTURES = 3


class Checks:
    """Collects what was checked, and what did not agree."""

    def __init__(self):
        self.count = 0
        self.problems = []

    def near(self, where, name, reported, computed, tolerance):
        """|reported - computed| <= tolerance (absolute); NaN agrees with nothing."""
        self.count += 1
        if not abs(reported - computed) <= tolerance:
            self.problems.append(f"{where}: {name} is {reported:.9g}, recomputed {computed:.9g} (+- {tolerance:.2g})")

    def true(self, where, what, holds):
        self.count += 1
        if not holds:
            self.problems.append(f"{where}: {what}")


def place_of(section, index, row):
    return f"{section}[{index}] {row['method']}"


def check_time(checks, where, time):
    checks.true(where, "times are not min <= median <= max", time["min"] <= time["median"] <= time["max"])
    checks.true(where, "no runs", time["runs"] >= 1)
    if time["runs"] == 1:
        checks.true(where, "one run has a spread", time["min"] == time["max"])


def check_error_bounds(checks, where, row):
    """What holds for any error: the mean is within the root mean square, and that within the greatest."""
    error = row["error"]
    rmse = error.get("rmse")
    for name, value in error.items():
        checks.true(where, f"{name} is not finite", math.isfinite(value))
    slack = 1.0 + SUM_EPSILON
    # Relative to (1 + epsilon): equal images but for a constant have |bias| = rmse = max up to rounding.
    # A cause's RMSE is freed of the references' noise, its mean is not.
    if rmse is not None and "bias" in error and not row["method"].startswith("cause_"):
        checks.true(where, f"|bias| {error['bias']} exceeds rmse {rmse}", abs(error["bias"]) <= rmse * slack)
    if rmse is not None and "max" in error:
        checks.true(where, f"rmse {rmse} exceeds max {error['max']}", rmse <= error["max"] * slack)
    if "ssim" in error:
        checks.true(where, "ssim is not in [-1, 1]", -1.0 <= error["ssim"] <= 1.0 + SUM_EPSILON)
    if "flip" in error:
        checks.true(where, "flip is not in [0, 1]", 0.0 <= error["flip"] <= 1.0)
    # Of pictures, rmse is of linear and PSNR of display values: computed from the pictures.
    if rmse and "psnr_db" in error and "picture" not in row["parameters"]:
        peak = row["parameters"].get("peak", 1.0)
        checks.near(where, "psnr_db", error["psnr_db"], 20.0 * math.log10(peak / rmse), 1e-6)


def check_row(checks, where, row):
    if "time_ms" in row:
        check_time(checks, where, row["time_ms"])
    if row.get("error"):
        check_error_bounds(checks, where, row)
    if "bytes" in row and "bytes_total" in row:
        checks.true(where, "light data exceeds the total", row["bytes"] <= row["bytes_total"])
    for name in ("rate", "bake_s"):
        if name in row:
            checks.true(where, f"{name} is not above 0", row[name] > 0.0)


def limit_ratio(row):
    """The ratio of a row whose yardstick is a limit on its time, and of which of its times; None for others."""
    against = row.get("against", "")
    time = row.get("time_ms")
    if time is None:
        return None
    if against == "a stall of 100 ms, over the longest frame":
        return 100.0 / time["max"]
    words = against.split()
    if words[:2] == ["limit", "of"] and words[3].rstrip(",") in ("s", "ms"):
        return float(words[2]) * (1000.0 if words[3].startswith("s") else 1.0) / time["median"]
    return None


def check_storage(checks, where, row, rows):
    """Bytes of coefficients as science.md counts them: PTM 6 a layer texel, LPT 10 a column; and their ratio."""
    p = row["parameters"]
    texels = p["size"] ** 2
    coefficients = texels * (10 if p["basis"] == "lpt" else 6 * p["layers"]) * p["channels"]
    checks.near(where, "bytes", row["bytes"], coefficients * p["bits"] // 8, 0)
    if "ratio" not in row:
        return
    alike = ("size", "layers", "bits", "channels")
    ptm = [r for r in rows if r["method"] == "storage" and r["parameters"]["basis"] == "ptm"
           and all(r["parameters"][k] == p[k] for k in alike)]
    checks.true(where, "there is no PTM to compare with", len(ptm) == 1)
    if ptm:
        checks.near(where, "ratio", row["ratio"], row["bytes"] / ptm[0]["bytes"], SUM_EPSILON)


def check_speed(checks, rows):
    for index, row in enumerate(rows):
        where = place_of("speed", index, row)
        expected = limit_ratio(row)
        if expected is not None and "ratio" in row:
            checks.near(where, "ratio", row["ratio"], expected, 1e-9 * expected)
        if row["method"] == "storage":
            check_storage(checks, where, row, rows)


def check_picture(checks, where, row, folder, with_flip):
    parameters = row["parameters"]
    names = (parameters["picture"], parameters["reference_picture"])
    files = [folder / "pictures" / (name + ".exr") for name in names]
    for file in files:
        checks.true(where, f"{file.name} is missing", file.is_file())
    if not all(file.is_file() for file in files):
        return
    error = row.get("error", {})
    computed: PictureErrors = picture_errors(*files, parameters.get("display", "filmic"), with_flip)
    for name, (value, tolerance) in computed.figures.items():
        if name in error:
            checks.near(where, name, error[name], value, tolerance)


    if "reference_mean" in parameters:
        mean = float(read_linear(files[1]).mean())
        # Every pixel is rounded by so much at most, and so their mean.
        checks.near(where, "reference_mean", parameters["reference_mean"], mean,
                    (HALF_RELATIVE + PARAMETER_DIGITS) * abs(mean) + HALF_ABSOLUTE)


def check_noise(checks, where, row):
    """What is left of the RMSE without the reference's noise, in quadrature; and the bias over the mean."""
    parameters, error = row["parameters"], row.get("error", {})
    rmse = error.get("rmse")
    if "relative_bias" in parameters and parameters["reference_mean"] > 0.0:
        relative = error["bias"] / parameters["reference_mean"]
        checks.near(where, "relative_bias", parameters["relative_bias"], relative, 2 * PARAMETER_DIGITS * abs(relative))
    if rmse is None or not {"reference_noise_rmse", "rmse_without_noise"} <= parameters.keys():
        return
    noise, left = parameters["reference_noise_rmse"], parameters["rmse_without_noise"]
    expected = max(rmse**2 - noise**2, 0.0)
    # Squares of six digits: twice the relative error of either.
    checks.near(where, "rmse_without_noise squared", left**2, expected, 2 * PARAMETER_DIGITS * (noise**2 + expected))


def check_texel_render(checks, rows):
    sizes = {}
    for index, row in enumerate(rows):
        where, parameters = place_of("texel_render", index, row), row["parameters"]
        if "march_ms" in parameters:
            ratio = parameters["march_ms"] / row["time_ms"]["median"]
            checks.near(where, "ratio", row["ratio"], ratio, PARAMETER_DIGITS * ratio)
        if row["method"] == "texels":
            sizes.setdefault((parameters["view"], parameters["weathering"]), []).append(
                (parameters["levels"], row["bytes_total"]))
    for (view, weathering), levels in sizes.items():
        levels.sort()
        checks.true("texel_render", f"bytes do not rise with the columns, {view} at {weathering}",
                    all(a[1] < b[1] for a, b in zip(levels, levels[1:])))


def check_page(checks, folder, sections):
    page = (folder / "report.html").read_text(encoding="utf-8")
    for name in sections:
        checks.true("report.html", f"section {name} is missing", f'id="{name}"' in page)
    for plot in sorted((folder / "plots").glob("*.svg")):
        checks.true("report.html", f"plot {plot.stem} is missing", f'id="plot-{plot.stem}"' in page)
    listed = (folder / "files.txt").read_text(encoding="utf-8").split("\n")[:-1]
    for file in listed:
        checks.true("files.txt", f"{file} is missing", (folder / file).is_file())


def check_report(folder):
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    checks = Checks()
    flips = 0
    for section, content in report["sections"].items():
        for index, row in enumerate(content["rows"]):
            where = place_of(section, index, row)
            check_row(checks, where, row)
            check_noise(checks, where, row)
            if "picture" in row["parameters"] and "reference_picture" in row["parameters"]:
                with_flip = "flip" in row.get("error", {}) and flips < FLIP_PICTURES
                flips += with_flip
                check_picture(checks, where, row, folder, with_flip)
    if "speed" in report["sections"]:
        check_speed(checks, report["sections"]["speed"]["rows"])
    if "texel_render" in report["sections"]:
        check_texel_render(checks, report["sections"]["texel_render"]["rows"])
    check_tables(checks, folder, report["sections"])
    check_page(checks, folder, report["sections"])
    return checks


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    folder = parser.parse_args().folder
    try:
        checks = check_report(folder)
    except (OSError, ValueError, KeyError) as problem:
        print(f"{folder}: no report that can be checked: {problem!r}", file=sys.stderr)
        return 2
    for problem in checks.problems:
        print(problem)
    print(f"{checks.count} checks, {len(checks.problems)} do not agree")
    return 1 if checks.problems else 0


if __name__ == "__main__":
    sys.exit(main())
