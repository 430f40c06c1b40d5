"""
Capability specs: the YAML files in which packages say what a robot can do.

An *interface* (`capabilities.specs.interface`) declares topics, services, actions and parameters. A
*provider* (`capabilities.specs.provider`) implements an interface. A *semantic interface*
(`capabilities.specs.semantic_interface`) gives an interface a new meaning and new ROS names.
"""
