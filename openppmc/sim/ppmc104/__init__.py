"""What is around the PPMC-104 in the virtual board and in the model."""
