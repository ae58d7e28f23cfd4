"""Tools shared by all models: pieces and parts, outlines, textures, materials, occlusion bake, export."""
