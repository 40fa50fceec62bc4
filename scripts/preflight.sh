#!/bin/sh
# Checks make variables and the machine before anything runs. Arguments are NAME=VALUE pairs and the words `env`
# (a goal needs the environment), `parts=a,b`, `boards=a,b` and `hosts=a,b` (of PART on BOARD). Prints the first
# problem on one line, or nothing.
here=$(dirname "$0")

problem() { printf '%s\n' "$*"; exit 0; }

# number NAME VALUE MIN MAX: a decimal number in that range
number() {
    case $2 in
        '' | *[!0-9]* | ?????????????*) problem "$1=$2: expected a whole number from $3 to $4" ;;
    esac
    if [ "$2" -lt "$3" ] || [ "$2" -gt "$4" ]; then problem "$1=$2: expected a whole number from $3 to $4"; fi
}

need_env=''
python=''
parts=''
boards=''
hosts=''
most_xtal=16000000
most_baud=3000000

# limit PARAMETER DEFAULT: the last figure of "1e6 .. 20e6" beside a parameter in the header of the part's top
limit() {
    said=$(sed -n "s/^ *parameter .* $1 .*\/\/.*\.\. *\([0-9][0-9e_ ]*\).*/\1/p" "$here"/../rtl/*/"$part".sv 2>/dev/null)
    [ -n "$said" ] || said=$2
    echo "$said" | tr -d ' _' | awk '{ printf "%d", $1 }'
}
for word in "$@"; do
    name=${word%%=*}
    value=${word#*=}
    case $word in
        env) need_env=1 ;;
        parts=*) parts=${value%,} ;;
        boards=*) boards=${value%,} ;;
        hosts=*) hosts=${value%,} ;;
        python=*) python=$value ;;
        PART=*)
            # Without a Python there is no list, and that is the problem to tell.
            case ",$parts," in ,,) ;; *",$value,"*) ;; *) problem "PART=$value: no such part (known: $parts)" ;; esac
            part=${value%%-*} # its RTL; what follows is a mode of it
            most_xtal=$(limit XTAL_HZ $most_xtal)
            most_baud=$(limit BAUD $most_baud) ;;
        BOARD=*)
            board=$value
            case ",$boards," in *",$value,"*) ;; *) problem "BOARD=$value: no such board (known: $boards)" ;; esac ;;
        HOST=*)
            # A board that does not carry the part has no hosts; the build reports that.
            case ",$hosts," in ,,) ;; *",$value,"*) ;; *) problem "HOST=$value: $board with $part has only $hosts; choose one of these" ;; esac ;;
        SIM_MAIN=*) case $value in own | cocotb) ;; *) problem "SIM_MAIN=$value: expected own or cocotb" ;; esac ;;
        TIMING=*) case $value in FAST | DATASHEET) ;; *) problem "TIMING=$value: expected FAST or DATASHEET" ;; esac ;;
        READ_MAP=*) case $value in SHEET | FAMILY) ;; *) problem "READ_MAP=$value: expected SHEET or FAMILY" ;; esac ;;
        PHASE_IDLE=* | PHASE_ON=*) number "$name" "$value" 0 1 ;;
        RECORD=*) case $value in 0 | [4-9] | 1[0-6]) ;; *) problem "RECORD=$value: expected 0, or 4 to 16" ;; esac ;;
        XTAL_HZ=*) number "$name" "$value" 1000000 "$most_xtal" ;;
        BAUD=*) number "$name" "$value" 1200 "$most_baud" ;;
        T=*)
            case $value in
                and | or | not | '' | ,* | *, | *,,* | *[!A-Za-z0-9_.:,-]*)
                    problem "T=$value: expected (a part of) a test's name, of letters, digits and _ . : -, or some with commas" ;;
            esac ;;
        SEED=*) number "$name" "$value" 0 4294967295 ;;
        COUNT=*) number "$name" "$value" 1 1000000000 ;;
        CLK_HZ=*) number "$name" "$value" 8000000 200000000 ;;
        SCHEDULER=*)
            case $value in
                tcp://*:*[!0-9]* | tcp://:* | tcp://*[!A-Za-z0-9_.:-]*) problem "SCHEDULER=$value: expected tcp://host:port" ;;
                tcp://*:[0-9]*) ;;
                *) problem "SCHEDULER=$value: expected tcp://host:port" ;;
            esac ;;
        BREAK=* | FRESH=* | QUICK=* | WAVES=* | INSIDE=* | MODEL=*) number "$name" "$value" 0 1 ;;
        J=*) number "$name" "$value" 1 64 ;;
    esac
done
[ -n "$need_env" ] || exit 0

# Spaces and letters of any language do; these end a name in PATH, or in the scripts that pip writes.
case $PWD in
    *[:\"\$\`\\]* | *[[:cntrl:]]*)
        problem "the project's folder must not have : \" \$ \` or \\ in its path: $(printf %s "$PWD" | tr '[:cntrl:]' '?')" ;;
esac
for tool in git g++ perl; do
    command -v "$tool" >/dev/null 2>&1 || problem "$tool is not installed: install it with the package manager (Debian: apt install $tool)"
done
[ ! -x .venv/bin/python ] || exit 0
found=$("$here/find_python.sh" "$python")
if [ -z "$found" ]; then
    asked=${python:-python3}
    have=$("$asked" --version 2>&1 </dev/null | head -n 1)
    command -v "$asked" >/dev/null 2>&1 || have='not found'
    problem "Python 3.10 or newer is needed ($asked: $have): install one, or name it with PYTHON=/path/to/python3"
fi
"$found" -c 'import venv, ensurepip' >/dev/null 2>&1 </dev/null ||
    problem "$found has no venv module: install it (Debian: apt install python3-venv)"
