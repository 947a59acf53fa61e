"""Figures of rows from the tables and arrays of their section (core/report/section.h has the conventions)."""

import csv
import math
import re

import numpy as np

# Sums stand in the table with nine digits or more.
DIGITS = 1e-8
# Parameters of rows stand in six digits or more.
PARAMETER_DIGITS = 6e-6
# Sums of float values in double precision, in another order: relative, and to the values' size where they cancel.
ORDER = 1e-9
SUMS = ("weight", "squares", "sum", "max")
# Which protocol's lines an error of a row comes from, in tables that hold several.
PROTOCOLS = {"rmse": "held_out", "rmse_seen": "held_out_seen", "rmse_leave_one_out": "leave_one_out",
             "rmse_between": "between", "rmse_between_filled": "between_filled"}
# Elevations that parts of the held-out error are of, degrees.
ELEVATIONS = {"rmse_low": (0.0, 25.0), "rmse_middle": (25.0, 50.0), "rmse_high": (50.0, 90.0)}


def read_table(path):
    """A list of dictionaries, by the header's names."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def same(text, value):
    """Whether a field of a table is a parameter of a row."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        try:
            return float(text) == float(value)
        except ValueError:
            return False
    return text == str(value)


def keys_of(line):
    return [name for name in line if name not in SUMS and name not in ("method", "light")]


def lines_of(row, lines):
    parameters = row["parameters"]

    def belongs(line):
        return line["method"] == row["method"] and all(
            parameters.get(key) == "all" or same(line[key], parameters.get(key)) for key in keys_of(line))

    return [line for line in lines if belongs(line)]


def check_sums(checks, where, row, lines):
    """rmse, bias and max of a row from the sums over its lights."""
    error = row.get("error", {})
    if "rmse" not in error:
        return
    own = lines_of(row, lines)
    checks.true(where, "no line of the table belongs to it", bool(own))
    if not own:
        return
    weight, squares, total = (math.fsum(float(line[name]) for line in own) for name in SUMS[:3])
    rmse = math.sqrt(squares / weight)
    checks.near(where, "rmse", error["rmse"], rmse, DIGITS * rmse)
    if "bias" in error:
        size = math.fsum(abs(float(line["sum"])) for line in own) / weight
        checks.near(where, "bias", error["bias"], total / weight, DIGITS * (size + rmse))
    if "max" in error:
        greatest = max(float(line["max"]) for line in own)
        checks.near(where, "max", error["max"], greatest, DIGITS * greatest)


def check_relative(checks, where, row, rows, keys):
    """rmse_over_METHOD: this row's rmse over that of METHOD with the same parameters."""
    for name, value in row["parameters"].items():
        match = re.fullmatch(r"rmse_over_(\w+)", name)
        if not match:
            continue
        others = [other for other in rows if other["method"] == match.group(1)
                  and all(other["parameters"].get(key) == row["parameters"].get(key) for key in keys)]
        checks.true(where, f"{len(others)} rows of {match.group(1)} to compare with", len(others) == 1)
        if len(others) == 1:
            ratio = row["error"]["rmse"] / others[0]["error"]["rmse"]
            checks.near(where, name, value, ratio, PARAMETER_DIGITS * ratio)


def sums_of(method, truth, weight):
    difference = method.astype(np.float64) - truth
    return {"weight": weight.sum(), "squares": (weight * difference**2).sum(), "sum": (weight * difference).sum(),
            "max": np.abs(difference[weight > 0]).max()}


def check_arrays(checks, folder, section, lines):
    """Sums of the table from the values themselves, for the lights whose values were kept."""
    tables = folder / "tables"
    for truth_file in sorted(tables.glob(f"{section}_truth_*.npy")):
        light = truth_file.stem.rsplit("_", 1)[1]
        truth = np.load(truth_file).astype(np.float64)
        weight = np.load(tables / f"{section}_weight.npy").astype(np.float64)
        # Channels share the weights of their texels.
        weight = np.broadcast_to(weight, truth.shape) if truth.shape[-weight.ndim:] == weight.shape else weight
        methods = 0
        for method in dict.fromkeys(line["method"] for line in lines):
            file = tables / f"{section}_{method}_{light}.npy"
            own = [line for line in lines if line["method"] == method and same(line["light"], int(light))]
            if not file.is_file() or not own:
                continue
            methods += 1
            values = np.load(file)
            checks.true(file.name, "has another shape than the truth", values.shape == truth.shape == weight.shape)
            sums = sums_of(values, truth, weight)
            slack = {"weight": sums["weight"], "squares": sums["squares"], "max": sums["max"],
                     "sum": math.sqrt(sums["squares"] * sums["weight"])}  # |sum w e| <= that (Cauchy and Schwarz)
            for name, value in sums.items():
                checks.near(file.name, name, float(own[0][name]), value, (DIGITS + ORDER) * slack[name])
        checks.true(truth_file.name, "no method has values to compare with it", methods > 0)


def check_protocols(checks, where, row, lines):
    """Every kind of RMSE of a row from the lines of its protocol, and of its lights."""
    own = [line for line in lines if line["method"] == row["method"]]

    def rmse_of(some):
        weight = math.fsum(float(line["weights"]) for line in some)
        return math.sqrt(math.fsum(float(line["squares"]) for line in some) / weight)

    for name, value in row.get("error", {}).items():
        if name in PROTOCOLS:
            some = [line for line in own if line["protocol"] == PROTOCOLS[name]]
        elif name in ELEVATIONS:
            low, high = ELEVATIONS[name]
            some = [line for line in own if line["protocol"] == "held_out"
                    and low <= float(line["elevation_deg"]) < high]
        else:
            continue
        checks.true(where, f"no line of the table belongs to {name}", bool(some))
        if some:
            checks.near(where, name, value, rmse_of(some), DIGITS * value)


def of_one_protocol(lines, protocol):
    """Lines of a table of several protocols as a table of one has them."""
    return [{"method": line["method"], "light": line["light"], "weight": line["weights"], "squares": line["squares"],
             "sum": line["errors"], "max": line["max"]} for line in lines if line["protocol"] == protocol]


def check_tables(checks, folder, sections):
    """Every table is rectangular; tables of lights give the figures of their section's rows."""
    for path in sorted((folder / "tables").glob("*.csv")):
        lines = read_table(path)
        checks.true(path.name, "has lines longer than its header", all(None not in line for line in lines))
        section = path.stem.removesuffix("_lights")
        if section == path.stem or section not in sections or not lines:
            continue
        rows = sections[section]["rows"]
        if "protocol" in lines[0]:
            # The row of the samples' own noise compares no prediction.
            rows = [row for row in rows if row["method"] != "samples"]
            for index, row in enumerate(rows):
                check_protocols(checks, f"{section}[{index}] {row['method']}", row, lines)
            lines = of_one_protocol(lines, "held_out")
        if not lines or not set(SUMS) <= set(lines[0]):
            continue
        for index, row in enumerate(rows):
            where = f"{section}[{index}] {row['method']}"
            check_sums(checks, where, row, lines)
            check_relative(checks, where, row, rows, keys_of(lines[0]))
        check_arrays(checks, folder, section, lines)
