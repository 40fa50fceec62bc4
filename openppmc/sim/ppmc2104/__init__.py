"""What is around the PPMC-2104 in the virtual board and in the model."""
