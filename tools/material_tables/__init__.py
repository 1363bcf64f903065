"""Parts of tools/make_materials.py."""
