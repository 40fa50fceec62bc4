"""`make mutate`: mutants made by rule from every file of rtl/; tests run on each until one fails.

faults.py    the places of a file and their possible faults, from slang's syntax tree
schema.py    one copy of a file with all its mutants, selected when the simulation starts
suites.py    the tests for the mutants of a file, the fastest first
work.py      one mutant on a worker: killed by a test, survived, or endless
judged.yml   reviewed survivors that are equivalent, with the reason
page.py      docs/mutants.md
"""
