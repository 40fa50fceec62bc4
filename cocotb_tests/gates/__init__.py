"""What only gate-level simulations need: the board top that they run, its UART, models of FPGA cells."""
