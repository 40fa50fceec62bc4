"""Campaigns on Dask: `make test WITH=campaign`, in an environment that `make test` has no need of."""
