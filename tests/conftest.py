"""The suite neither reads nor writes the user's kept records, unless a test asks for a folder of its own."""

import os

os.environ["JUGGLEPROOF_CACHE"] = "off"
pytest_plugins = ["pytester"]
