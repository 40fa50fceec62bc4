#!/bin/sh
# Opens the demo's waveforms with the saved view of whichever viewer is installed.
cd "$(dirname "$0")/.." || exit 1
dir=build/demo
if [ ! -f "$dir/ppmc104.vcd" ]; then
    echo "error: $dir/ppmc104.vcd is not there yet: run 'make demo' first" >&2
    exit 1
elif command -v gtkwave >/dev/null 2>&1; then
    exec gtkwave "$dir/ppmc104.vcd" "$dir/ppmc104.gtkw"
elif command -v surfer >/dev/null 2>&1; then
    exec surfer --command-file "$dir/ppmc104.sucl" "$dir/ppmc104.vcd"
else
    echo "error: neither gtkwave nor surfer is installed (Debian: apt install gtkwave); the waveforms are in $dir/ppmc104.vcd" >&2
    exit 1
fi
