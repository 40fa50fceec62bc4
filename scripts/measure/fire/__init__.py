"""Sessions of the host drivers on a line with faults.

line.py      a port with faults at single bytes: loss, doubling, inverted bit, delay, unplugging, …
boards.py    the boards on which the sessions run, and the true positions of their motors
session.py   one session of a board, and the checks of the results that its driver states
sweep.py     the faults that a seed selects for a session
__main__.py  `make fire`: any number of sessions as a campaign
"""
