"""Tests of openppmc.ophyd on golden models; `make test WITH=ophyd`."""
