"""The PPMC-312's golden model: acceptance checks (played on the RTL, too), tables, plans, properties."""
