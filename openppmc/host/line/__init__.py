"""A line with several stations, whatever part they are."""
