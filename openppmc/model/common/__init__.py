"""What every golden model is made of: time, events, edges, blocks of a clocked part, a UART."""
