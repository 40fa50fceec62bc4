"""An axis of any part: set-up, motions, homing, registers."""
