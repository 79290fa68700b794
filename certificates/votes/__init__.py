"""Voting routes: other ways to decide a statement.  None of them is believed; each vote is recorded
beside the certificate.
"""
