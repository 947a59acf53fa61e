"""Figures of rows from the tables and arrays of their section."""

import csv


def read_table(path):
    """A list of dictionaries, by the header's names."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_tables(checks, folder, sections):
    """Every table is readable and rectangular."""
    for path in sorted((folder / "tables").glob("*.csv")):
        rows = read_table(path)
        checks.true(path.name, "rows of another length than the header", all(None not in row for row in rows))
