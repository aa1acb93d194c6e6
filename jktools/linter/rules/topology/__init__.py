"""JK2xx: sectors, surfaces and adjoins."""
