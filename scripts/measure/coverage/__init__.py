"""`make coverage`: coverage of the RTL by `make test`, and coverage crosses of the data sheets.

collecting.py  a pytest plugin that lists which tests share a simulator process
work.py        runs such a group with counting builds, and packs the covered points
counted.py     copies of the RTL in which Verilator counts correctly
elaborated.py  functions that no simulation runs
points.py      Verilator's counts: points of the RTL, their kinds, lines
sums.py        sums of all groups: by folder, by file, holes
holes.yml      accepted holes, each with its reason
page.py        docs/coverage.md
"""
