"""What is around an STMC: its machine."""
