"""Commands and presenter of the command line for a PPMC-312."""
