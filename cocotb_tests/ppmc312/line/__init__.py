"""Sixteen PPMC-312 stations in serial mode on one line, and a master that makes every kind of mistake.

setting.py     ports and build of tb/ppmc312/line; library.py compiles the station that all sixteen share
wave.py        characters as levels of a line, also overlapping ones
models.py      the same line made of golden models, with the same pins
master.py      a master of the line, for the RTL and for golden models
compare.py     compares each RTL station with a golden model that receives the same input levels
scenarios.py   disturbances on a line; after each of them one poll recovers every station
tb_line.py     runs the scenarios on the RTL and compares all outputs; test_line.py runs them,
               also on models alone
stream.py      random characters for `make soak PART=ppmc312-serial`; tb_stream.py: samples on the RTL
"""
