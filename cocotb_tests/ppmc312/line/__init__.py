"""Sixteen stations of the PPMC-312 in serial mode on one line, and a master with all bad habits.

setting.py     ports and build of tb/ppmc312/line; library.py compiles the station that all sixteen share
wave.py        characters as levels of a line, several of them over each other
models.py      the same line of golden models, the same pins
master.py      a master of the line: over the RTL or over the golden models
compare.py     what each station saw on the RTL, replayed into a golden model of its own
scenes.py      what goes wrong on a line; after each of them one poll brings every station back
tb_line.py     the scenes on the RTL, all outputs compared; test_line.py runs them, and the models alone
stream.py      random characters for `make soak PART=ppmc312-serial`; tb_stream.py: samples on the RTL
"""
