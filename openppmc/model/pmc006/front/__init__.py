"""The PMC006B4's side towards its host: serial line, frames."""
