"""Code for gate-level simulations only: the board top that they run, its UART, models of FPGA cells."""
