"""Components that the golden models of several devices share."""
