#!/bin/sh
# Prints the Python to build the environment with: $1 if given, else the first of the usual names that is new enough.
# Prints nothing when there is none.
new_enough='import sys; sys.exit(sys.version_info < (3, 10))'
for name in ${1:-python3 python3.13 python3.12 python3.11 python3.10 python3.14 python}; do
    if "$name" -c "$new_enough" </dev/null >/dev/null 2>&1; then
        command -v "$name"
        exit 0
    fi
done
