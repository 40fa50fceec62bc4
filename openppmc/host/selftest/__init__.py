"""`openppmc selftest`: a board against the golden model, every recorded edge of every output.

    plan       sections of a test, and how they talk to the part without filling the recorder
    bytes      what the parts on a byte bus are made to do: every code, moves of each kind
    recording  records of the bridge as a recording of the part
    run        plays sections, compares, collects
    page       what is told at the end, as text and JSON

A part's own `selftest` (column of the table) says what is recorded and what is played.
"""
