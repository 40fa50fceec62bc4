"""The STMC's golden model: acceptance checks, examples, data sheet times, properties."""
