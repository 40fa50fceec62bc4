"""Golden model of the PPMC-312: acceptance checks (also run on the RTL), tables, plans, properties."""
