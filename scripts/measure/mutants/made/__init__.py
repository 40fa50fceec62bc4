"""`make mutate`: mutants made by rule from every file of rtl/; tests run on each until one fails.

faults.py    the places of a file and their possible faults, from slang's syntax tree
schema.py    one copy of a file with all its mutants, selected when the simulation starts
suites.py    the tests for the mutants of a file, the fastest first
equal.py     the proof that a mutant is equal to the RTL in every part
graph.py     and-inverter graphs, in which these proofs are made
replay.py    recorded tests, replayed into all mutants of a folder
work.py      one mutant on a worker: killed, equal, survived, or endless
killed.py    docs/killed.json: what need not be tried again
judged.yml   reviewed survivors that are equivalent, with the reason
page.py      docs/mutants.md
"""
