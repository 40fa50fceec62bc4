#!/bin/sh
# Opens the waveforms of the last demo, with their saved view, in GTKWave or else in Surfer.
cd "$(dirname "$0")/.." || exit 1
dir=build/demo
vcd=$(ls "$dir"/*.vcd 2>/dev/null | head -n 1)
view=${vcd%.vcd}
if [ -z "$vcd" ]; then
    echo "error: there are no waveforms in $dir yet: run 'make demo' first" >&2
    exit 1
elif command -v gtkwave >/dev/null 2>&1; then
    exec gtkwave "$vcd" "$view.gtkw"
elif command -v surfer >/dev/null 2>&1; then
    exec surfer --command-file "$view.sucl" "$vcd"
else
    echo "error: neither gtkwave nor surfer is installed (Debian: apt install gtkwave); the waveforms are in $vcd" >&2
    exit 1
fi
