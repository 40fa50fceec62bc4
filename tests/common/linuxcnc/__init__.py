"""`openppmc hal` in LinuxCNC itself, `make test WITH=linuxcnc`."""
