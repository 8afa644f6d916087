#!/usr/bin/env python3
"""no licence"""
