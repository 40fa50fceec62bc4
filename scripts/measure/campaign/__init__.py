"""Campaigns: many independent jobs on Dask workers, with results that outlive an interruption.

jobs.py      what a job, its result and a campaign are
run.py       runs a campaign: takes over what is on file, submits the rest, records what ends
cluster.py   the workers: processes of this machine, or those of a scheduler on the network
on_worker.py what runs in a worker beside the job: the check that it has the same tree
store.py     the file of results (SQLite), build/campaign/results.sqlite
tree.py      a digest of all sources that results depend on
show.py      progress on a terminal, or a line now and then in a log
__main__.py  `make scheduler`, `make worker`
"""
