"""What the parts with one axis on a byte bus share: host port, commands, timed motion, prediction."""
