"""The PPMC-312's side towards its host: parallel registers, serial station, responses."""
