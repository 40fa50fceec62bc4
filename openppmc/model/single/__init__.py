"""Parts with one axis on a byte bus: host port, commands, timed motion, prediction."""
