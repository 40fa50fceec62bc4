"""Host interfaces of the PPMC-312: parallel registers, serial station, responses."""
