"""Campaigns: many independent jobs on Dask workers, with results that survive an interruption.

jobs.py      definitions of a job, its result and a campaign
run.py       runs a campaign: reuses stored results, submits the other jobs, stores their results
cluster.py   the workers: processes of this machine, or those of a scheduler on the network
on_worker.py code that runs in a worker in addition to the job: the check of its source tree
store.py     the file of results (SQLite), build/campaign/results.sqlite
tree.py      a digest of all sources that results depend on
show.py      progress on a terminal, or a line every minute in a log
__main__.py  `make scheduler`, `make worker`
"""
