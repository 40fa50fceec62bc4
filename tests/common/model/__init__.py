"""The parts of golden models that parts share."""
