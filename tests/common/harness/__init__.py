"""The simulator harness, the scripts of make targets, and the pages that these write."""
