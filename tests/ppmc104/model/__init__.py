"""The PPMC-104's golden model: acceptance checks, edges of rules, properties."""
