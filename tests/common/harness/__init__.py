"""The simulator harness, the scripts behind make targets, the pages that these write."""
