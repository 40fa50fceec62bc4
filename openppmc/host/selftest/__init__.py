"""Self-test: compares every edge of every output of a part on a board with the golden model.

`openppmc selftest` runs it.

    plan       sections of a test, and accesses to the part that need few records
    bytes      stimuli of the parts on a byte bus: every code, moves of each kind
    recording  conversion of the bridge's records to a recording of the part
    run        plays sections, compares and collects results
    page       result as text and JSON

The table of parts has a column with the `selftest` module of each part, which defines the recorded pins and
the stimuli.
"""
