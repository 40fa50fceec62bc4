"""The PMC006B4's golden model: acceptance checks, blocks, tables."""
