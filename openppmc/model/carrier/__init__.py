"""Surroundings of a part: the UART bridge, the carrier, switches along an axis, EEPROM."""
