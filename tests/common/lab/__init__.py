"""Tests of openppmc.ophyd and the EPICS IOC on golden models; `make test WITH=ophyd`."""
