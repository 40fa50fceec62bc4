"""Campaigns on Dask: `make test WITH=campaign`, in an environment that `make test` does not need."""
