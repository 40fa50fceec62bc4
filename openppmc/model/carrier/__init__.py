"""What stands around a part: the UART bridge, the modelled board, plant, EEPROM."""
