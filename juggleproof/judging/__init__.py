"""Claims, how they are judged, and what is registered of them."""
