"""`make mutate`: mutants made by rule of every file of rtl/, each run against tests until one fails.

faults.py    the places of a file and what may be wrong there, from slang's syntax tree
schema.py    one copy of a file that holds all its mutants, chosen when the simulation starts
suites.py    which tests a file's mutants meet, the quickest first
work.py      one mutant on a worker: killed by which test, alive, without end
judged.yml   survivors that somebody has looked at: equivalent, with the reason
page.py      docs/mutants.md
"""
