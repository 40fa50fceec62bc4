"""Campaigns on Dask: `make test-campaign`, in an environment that `make test` has no need of."""
