"""The demo of the bank: 32 axes with 32 ramps."""
