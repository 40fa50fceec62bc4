"""Self-test: every recorded edge of every output of a board against the golden model.

`openppmc selftest` runs it.

    plan       sections of a test, and the accesses to the part that do not fill the recorder
    bytes      stimuli of the parts on a byte bus: every code, moves of each kind
    recording  records of the bridge as a recording of the part
    run        plays sections, compares and collects results
    page       result as text and JSON

The `selftest` module of a part (column of the table of parts) defines the recorded pins and the stimuli.
"""
