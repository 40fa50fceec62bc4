"""The PPMC-2104's golden model: acceptance checks, errors, inputs, examples, properties."""
