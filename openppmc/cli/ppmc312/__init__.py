"""What the command line shows, forecasts and reads for a PPMC-312."""
