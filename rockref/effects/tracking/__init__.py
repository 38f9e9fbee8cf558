"""How a camera's poses lie to the body and to the plate: effects of tosses, which a gyroscope does not know."""
