"""What is around the STMC in the virtual board and in the model."""
