"""Self-test: compares every recorded edge of every output of a board with the golden model.

`openppmc selftest` runs it.

    plan       sections of a test, and accesses to the part that need few records
    bytes      stimuli of the parts on a byte bus: every code, moves of each kind
    recording  conversion of the bridge's records to a recording of the part
    run        plays sections, compares and collects results
    page       result as text and JSON

The `selftest` module of a part (column of the table of parts) defines the recorded pins and the stimuli.
"""
