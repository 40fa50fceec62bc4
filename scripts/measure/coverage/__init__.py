"""`make coverage`: what `make test` reaches of the RTL, and what it crosses of the sheets.

collecting.py  a pytest plugin that tells which tests share a simulator process
work.py        runs such a group with counting builds, and packs what it has reached
counted.py     copies of the RTL that Verilator counts right
elaborated.py  functions that no simulation runs
points.py      Verilator's counts: points of the RTL, their kinds, lines
sums.py        all groups together: by folder, by file, holes
holes.yml      holes that stay, each with its reason
page.py        docs/coverage.md
"""
