"""Sessions of the host drivers on a line with faults.

line.py      a port that damages single bytes: lost, doubled, flipped, late, unplugged, …
boards.py    the boards on which the sessions run, and the true positions of their motors
session.py   a session of each board, and the checks of what its driver states
sweep.py     the faults of a session by its seed
__main__.py  `make fire`: any number of sessions as a campaign
"""
