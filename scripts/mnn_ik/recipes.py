"""What is trained, by name."""
from mnn_ik.autoencoder import Recipe

RECIPES = {
    "paper": Recipe(kept_steps=(1000, 2000, 4000)),
    "wide-fast": Recipe(batch=256, steps=1500, rate=1e-3, falls=True),
    "narrow": Recipe(width=128, steps=10000, kept_steps=(1000, 4000)),
    "narrow-denoising": Recipe(width=128, steps=10000, noise=1.0),
}
