"""The ground floor: what strangers wrote is read here, safely, and nowhere else."""
