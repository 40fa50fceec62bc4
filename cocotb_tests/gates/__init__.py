"""Code for gate-level simulations only: the simulated board top, its UART, and models of FPGA cells."""
