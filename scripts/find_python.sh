#!/bin/sh
# Runs Python with the arguments $2, $3, …: the Python of .venv; else the one that $1 names; if $1 is empty, the
# first of the usual names. Python must be 3.10 or newer; if there is none, this prints a line `error: …`.
python=$1
shift
new_enough() { "$1" -c 'import sys; sys.exit(sys.version_info < (3, 10))' </dev/null >/dev/null 2>&1; }
if new_enough .venv/bin/python; then exec .venv/bin/python "$@"; fi
if [ -n "$python" ]; then
    if new_enough "$python"; then exec "$python" "$@"; fi
else
    for name in python3 python3.13 python3.12 python3.11 python3.10 python3.14 python; do
        if new_enough "$name"; then exec "$name" "$@"; fi
    done
fi
python=${python:-python3}
have=$("$python" --version 2>&1 </dev/null | head -n 1)
command -v "$python" >/dev/null 2>&1 || have='not found'
echo "error: Python 3.10 or newer is needed ($python: $have): install one, or name it with PYTHON=/path/to/python3"
