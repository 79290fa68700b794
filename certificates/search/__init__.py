"""The untrusted search: finds certificates that the checker then reads; nothing here has to be believed."""
