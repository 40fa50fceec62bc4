"""The UART bridge from the PC's side: frames, scripts, session, link."""
