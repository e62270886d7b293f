#!/usr/bin/env python3
"""validate_schema.py SCHEMA FILE...: checks JSON files against a JSON Schema; exit 1 names every violation."""

import json
import sys

import jsonschema


def refuse_constant(name):
    """NaN and Infinity are no JSON, though Python reads them."""
    raise ValueError(f"{name} is not JSON")


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file, parse_constant=refuse_constant)


def violations(validator, path):
    try:
        document = load(path)
    except (OSError, ValueError) as error:
        return [f"{path}: {error}"]
    errors = sorted(validator.iter_errors(document), key=lambda e: [str(part) for part in e.absolute_path])
    return [f"{path}: /{'/'.join(map(str, e.absolute_path))}: {e.message[:300]}" for e in errors]


def schema_errors(schema_file, *files):
    """Every violation on a line of its own."""
    schema = load(schema_file)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return "\n".join(line for path in files for line in violations(kind(schema), path))


def main(argv):
    if len(argv) < 3:
        sys.exit(__doc__)
    found = schema_errors(*argv[1:])
    print(found, end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
