"""What drivers are made of without a port: units, limits of the parts, ends of motions, errors. Pure."""
