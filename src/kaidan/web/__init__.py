"""The service and the page: `kaidan serve`, the verbs over HTTP for a browser or a robot.

A request becomes a task of a worker process, which answers with the JSON of the command; the server
itself judges nothing, so that no request takes it down.
"""
