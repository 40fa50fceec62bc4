"""openppmc.ophyd on golden models, `make test-lab`."""
